; check: exit 1
; error K-0144 at 16:1
; error K-0144 at 17:1
; error K-0144 at 19:1
; error K-0144 at 20:1
; error K-0144 at 21:1
; error K-0144 at 22:7
"BREAK" = "$BREAK"
"ELSE" = "#ELSE"
"HASH" = "#"
"HIDE" = "#COMMENT BEGIN"
"HEAD" = "%L SUB"
"JUMP" = "$GOTO [E]"
"NAME" = "G01 X1 F600 (costs 5 $)"
"NAME"
"BREAK"
"ELSE"
#IF 1
"HASH"ELSE
"HIDE"
"HEAD"
$IF 1 "JUMP"
#ENDIF
[E] M30
