; check: exit 1
; error 20186 at 3:30
#GET CMDPOS [P1=X, P2=Y, P3=Z
M30
