autocmd BufRead,BufNewFile *.tyn setfiletype tyndall
