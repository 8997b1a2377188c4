; check: exit 1
; error K-0019 at 4:4
; error K-0019 at 5:7
P1=FSTRING[X]
V.P.T=FSTRING["a",1]
M30
