; check: exit 1
; error 21157 at 3:11
#IDENT RD SYN [AX=X ID=S-0-0104 P=P1 TYP=2 DEC=2 SERC]
M30
