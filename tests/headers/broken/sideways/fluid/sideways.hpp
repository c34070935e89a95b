#pragma once
#include "membrane/batch.hpp"
