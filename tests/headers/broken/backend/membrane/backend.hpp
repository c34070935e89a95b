#pragma once
#include <thrust/for_each.h>
