; check: exit 1
; error 20886 at 4:1
; error 20886 at 5:1
#CYL [Z, X, X60]
#FACE [X, Y]
M30
