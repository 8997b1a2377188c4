; run: exit 0
; warning K-0111 at 7:2
; end X20 Y10
; passes X10 Y0
(the corner is rounded without the command, and reached with it)
G261 G01 F6000 X10
X[COMP OFF LEAD]
Y10
G260
X20
M30
