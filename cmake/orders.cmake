# Orders whose generated code is committed. Adding an order is this one line.
set(ZONAL_COMMITTED_ORDERS 2 3 4 5 6 7 8 9 10)
# Those of them whose shaders (GLSL, SPIR-V) are committed as well.
set(ZONAL_COMMITTED_SHADER_ORDERS 3 4 5 6)
