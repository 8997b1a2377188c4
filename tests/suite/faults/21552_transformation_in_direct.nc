; check --identity-trafo: exit 1
; warning K-0111 at 4:1
; error 21552 at 5:1
#PTP ON
#TRAFO ON
M30
