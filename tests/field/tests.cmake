cavea_test(field field)
