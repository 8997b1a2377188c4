; check: exit 1
; page 253618059 diagnosis 21158, wrong
; error 21158 at 4:10
#COMMAND RD SYN [AX=X ID="S-0-0099"]
M30
