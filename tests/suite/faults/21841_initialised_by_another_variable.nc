; check --set external.number_used_variables=1 --set external.var[0].name=A --set external.init=V.E.A=V.G.FEEDRATE: exit 0
; warning 21841 at --set 1:1
M30
