; check: exit 1
; error 21089 at 3:17
#IDENT WR [AX=X AX=Y VAL=1]
M30
