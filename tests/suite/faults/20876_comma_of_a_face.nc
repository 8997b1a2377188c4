; check: exit 1
; error 20876 at 4:7
; error 20886 at 4:1
#FACE [X Y]
M30
