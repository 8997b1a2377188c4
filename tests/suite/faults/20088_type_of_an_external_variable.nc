; check --set external.number_used_variables=1 --set external.var[0].name=A --set external.var[0].type=INT: exit 0
; warning 20088 at --set 1:1
M30
