# Orders whose generated code is committed. Adding an order is this one line.
set(ZONAL_COMMITTED_ORDERS 2 3 4 5 6 7 8 9 10)
