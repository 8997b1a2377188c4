; check: exit 1
; page 1256561291 diagnosis 22385, wrong
; warning K-0111 at 5:1
; error 22385 at 6:1
G201 X1
#MANUAL [ORI_MODE=1]
M30
