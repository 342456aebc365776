cavea_test(mesh mesh)
