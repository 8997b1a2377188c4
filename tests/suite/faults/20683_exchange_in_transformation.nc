; check --identity-trafo: exit 1
; warning K-0111 at 4:1
; error 20683 at 5:1
#TRAFO ON
#PUT AX [X]
M30
