# nverts 4
# nfaces 2
# bb_min 0 0 0
# bb_max 1 1 0.5
v 0 0 0
v 1 0 0
v 0 1 0
f -3 2 3
v 1 1 0.5
f -3 -1 -2
