; check: exit 1
; error 20186 at 3:13
#GET CMDPOS [P1=X P2=Y]
M30
