; check: exit 1
; error 21461 at 7:9
; error 21461 at 8:6
#VAR
V.P.I : SGN32
#ENDVAR
V.P.I = "1" + "10"
G01 X["5"] F100
M30
