; run: exit 0
; end X5
; warning K-0109 at called/unpassed.nc 1:3
(a cycle reads a parameter that it did not get: it is 0)
L CYCLE [NAME=called/unpassed.nc @P1=1]
M30
