#pragma once
// All of Cairn's public face.

#include "cairn/body.h"
#include "cairn/ids.h"
#include "cairn/math.h"
#include "cairn/query.h"
#include "cairn/report.h"
#include "cairn/result.h"
#include "cairn/settings.h"
#include "cairn/shape.h"
#include "cairn/types.h"
#include "cairn/version.h"
#include "cairn/world.h"
