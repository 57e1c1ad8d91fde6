# Orders whose lobe tables and generated code are committed. Adding an order is this one line.
set(ZONAL_COMMITTED_ORDERS 3 4 5 6)
