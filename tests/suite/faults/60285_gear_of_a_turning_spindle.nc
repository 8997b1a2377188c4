; check --set S.getriebe[1].nummer=2: exit 1
; error 60285 at 4:6
S500 M3
G112 S2
M30
