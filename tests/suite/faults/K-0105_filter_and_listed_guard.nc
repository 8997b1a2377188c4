; check --set X.vib_guard.active=1 --set Y.vib_guard.active=1 --set Z.vib_guard.active=1: exit 1
; error K-0105 at 3:1
#FILTER ON
M30
