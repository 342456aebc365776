cavea_test(subdivide subdivide)
