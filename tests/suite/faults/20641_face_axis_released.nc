; run --set X.kenngr.achs_mode=65: exit 1
; error 20641 at 5:1
G18 G00 X20
G96 S63
#PUT AX [X]
M30
