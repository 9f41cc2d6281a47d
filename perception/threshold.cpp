#include "perception/threshold.h"
