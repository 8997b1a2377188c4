; run: exit 0
; page 15557121163 kept variables (V.S), array
; end X20
#VAR
V.S.VAR[5] = [5,10,10,15,20]
#ENDVAR
N20 G00 XV.S.VAR[4]
N30 M30
