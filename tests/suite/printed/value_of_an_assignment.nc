; run: exit 0
; page 15557119627 variables of the main program, older manual
; end X20
#VAR
V.P.VAR_5
#ENDVAR
N10 V.P.VAR_5 = 20
N20 G01 XV.P.VAR_5 F2000
N30 M30
