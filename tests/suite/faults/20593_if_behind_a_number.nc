; check: exit 1
; error 20593 at 3:5
N10 #IF 1
#ENDIF
M30
