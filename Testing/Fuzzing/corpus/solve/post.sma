# a comment
f 1 2 4
v 0 0 0
f 2 3 4
v 1 0 0
v 1 1 0.5
v 0 1 0
