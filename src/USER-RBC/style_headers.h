// Every header of a style in this package. No include guard: styles.cpp includes the list twice,
// once for the classes and once for the table.
#include "compute_rbc_aggregate.h"
#include "compute_rbc_cell.h"
#include "fix_rbc_fluid.h"
#include "fix_rbc_ib.h"
#include "fix_rbc_membrane.h"
#include "fix_rbc_port.h"
#include "fix_rbc_vtk.h"
#include "fix_rbc_wall.h"
#include "pair_rbc_jkr.h"
#include "rbc_create.h"
#include "rbc_surface.h"
#include "region_rbc_mesh.h"
