; check --identity-trafo: exit 1
; error 21514 at 3:1
#ORI MODE [VECTOR U=0 V=0 W=0]
M30
