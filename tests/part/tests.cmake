cavea_test(part part field)
