; run: exit 0
; page 308729483 axis compensations switched (COMP)
; warning K-0111 at 5:6
; end X20
N10 X[COMP OFF CROSS PLANE]
N50 X[COMP OFF CROSS] Y[COMP ON LEAD]
N60 G01 X20 F1000
M30
