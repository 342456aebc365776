cavea_test(remesh remesh)
