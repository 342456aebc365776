cavea_test(surface surface)
