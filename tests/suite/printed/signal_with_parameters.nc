; run: exit 0
; page 207431819 signal with keys of parameters (#SIGNAL [IDP100 ..])
; end X0
P100 = 814
#VAR
V.P.SYNC = 5
#ENDVAR
#SIGNAL [IDP100 P[0]= V.P.SYNC CH3]
M30
