; run: exit 0
; page 303637387 variables of a measuring cycle in a message
; note K-0081 at 8:1
#VAR
V.CYC.SysRetC = 2
#ENDVAR
N10 #FILE NAME [MSG="SysMeasWcsResult.txt"]
N20 #MSG SAVE ["V.CYC.SysRetC =%f", V.CYC.SysRetC]
N30 M30
