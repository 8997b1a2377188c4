; check: exit 1
; error 21158 at 3:10
#COMMAND RD SYN [AX=X ID="S-0-0099"]
M30
