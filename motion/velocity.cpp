#include "motion/velocity.h"
