; check: exit 1
; page 252834699 diagnosis 20875, wrong
; error 20875 at 4:14
N110 #FACE[X,J,Z]
N120 M30
