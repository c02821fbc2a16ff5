// Nothing: the target that parses what most sources include wants a source of its own (src/CMakeLists.txt).
