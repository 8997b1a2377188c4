; check: exit 1
; error 20604 at 3:7
#PSET X94967296
M30
