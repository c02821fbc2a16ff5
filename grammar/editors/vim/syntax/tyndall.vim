" Colours for scene files of the Tyndall renderer.
if exists('b:current_syntax')
  finish
endif

syntax match tyndallNumber /\v(<\d+(\.\d+)?|\.\d+)([eE][-+]?\d+)?(deg|rad|mm|cm|km|ms|m|s|K|\%)?/
syntax match tyndallColor /\v#(\x{6}|\x{3})>/
syntax match tyndallEscape /\v\\([nt"\\{}]|u\{\x{1,6}\})/ contained
syntax region tyndallInterpolation matchgroup=tyndallEscape start=/{/ end=/}/ contained oneline contains=TOP
syntax region tyndallString start=/"/ end=/"/ oneline contains=tyndallEscape,tyndallInterpolation
syntax region tyndallComment start=+//+ end=/$/ contains=@Spell
syntax region tyndallComment start=+/\*+ end=+\*/+ contains=tyndallComment,@Spell

" generated: words
syntax keyword tyndallConstant false pi true
syntax keyword tyndallOperator and not or
syntax keyword tyndallDefinition def let material medium object var
syntax keyword tyndallControl else for if in include place return then
syntax keyword tyndallInput N P frame n p time uv
syntax keyword tyndallStatement animation box camera cone curves cylinder difference disk gltf group heightfield intersection lathe light mesh plane prism quad render sphere sweep text torus union volume
syntax match tyndallBuiltin /\v<(abs|acos|append|asin|atan|atan2|blackbody|bounds|ceil|cells|checker|clamp|cos|cross|curl|direction|distance|dot|draine|droplets|exp|fbm|fbm01|floor|fournier_forand|fract|grid|hg|hsv|image|isotropic|keys|length|log|look_at|luminance|matrix|max|min|mix|mod|noise|noise01|normalize|pow|print|random|rayleigh|reflect|remap|ridged|ridged01|rotate|rotate_x|rotate_y|rotate_z|round|saturate|scale|sd_box|sd_capsule|sd_cone|sd_cylinder|sd_ellipsoid|sd_plane|sd_sphere|sd_torus|sign|sin|sky|smooth_max|smooth_subtract|smooth_union|smoothstep|sort|sqrt|step|sum|tan|translate|turbulence|turbulence01|vnoise|warp|worley)>\ze\s*\(/
" generated end

" A name before a colon is a parameter.
syntax match tyndallParameter /\v<\h\w*\ze\s*:/

highlight default link tyndallNumber Number
highlight default link tyndallColor Number
highlight default link tyndallEscape SpecialChar
highlight default link tyndallString String
highlight default link tyndallComment Comment
highlight default link tyndallConstant Constant
highlight default link tyndallOperator Operator
highlight default link tyndallDefinition Statement
highlight default link tyndallControl Conditional
highlight default link tyndallInput Identifier
highlight default link tyndallStatement Type
highlight default link tyndallBuiltin Function
highlight default link tyndallParameter Identifier

setlocal commentstring=//\ %s
let b:current_syntax = 'tyndall'
