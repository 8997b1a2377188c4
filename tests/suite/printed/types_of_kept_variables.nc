; run: exit 0
; page 207973899 variables of all main programs (V.S)
; end X20 Y11.34 Z20
#VAR
  V.S.VAR1
  V.S.VAR2 : UNS32 = 200
  V.S.VAR3 : REAL64 = 11.34
  V.S.VAR4 : BOOLEAN
  V.S.VAR[5] = [5,10,10,15,20]
#ENDVAR
N10 G00 XV.S.VAR[4] YV.S.VAR3 Z[V.S.VAR2/10+V.S.VAR4+V.S.VAR1]
N20 M30
