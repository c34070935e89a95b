#pragma once
#include "fluid/state.hpp"
