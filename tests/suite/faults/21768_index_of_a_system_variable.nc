; run: exit 1
; error 21768 at 4:4
X3 F600
P1=V.A.ABS.X[99]
M30
