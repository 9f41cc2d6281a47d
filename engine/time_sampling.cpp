#include "engine/time_sampling.h"
