; check: exit 1
; page 252834699 diagnosis 20875, wrong
; error 20875 at 4:13
N110 #CYL[X,J]
N120 M30
