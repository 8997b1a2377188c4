; run: exit 1
; error 20450 at 4:12
F600
#TRAFO OFF X5
M30
