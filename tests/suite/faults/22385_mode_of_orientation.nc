; check: exit 1
; warning K-0111 at 4:1
; error 22385 at 5:1
G201 X1
#MANUAL [ORI_MODE=1]
M30
