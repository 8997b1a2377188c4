; run: exit 0
; page 15556616843 search in texts
; end X14 Y0
#VAR
V.P.STR1 : STRING[50] = "Hello world! How are you?"
V.P.STR2 : STRING[50] = "How"
#ENDVAR
P1 = FIND[V.P.STR1, V.P.STR2]
P2 = FIND[V.P.STR1, "Now"]
N10 G00 XP1 YP2
N20 M30
