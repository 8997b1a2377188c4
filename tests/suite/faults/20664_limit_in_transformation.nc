; check --identity-trafo: exit 1
; warning K-0111 at 4:1
; error 20664 at 5:1
#TRAFO ON
G98 X-500
M30
