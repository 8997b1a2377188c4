; check: exit 1
; error 21872 at 3:14
#FACE [ORI=1 ORI=1]
M30
