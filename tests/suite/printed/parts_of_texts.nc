; run: exit 0
; page 206023179 operations with texts
#VAR
V.P.STR : STRING[50]
#ENDVAR
N10 V.P.STR = "Hello" + " world!"
N20 $IF V.P.STR != "Hello world!"
N30 #ERROR [ID 1]
N40 $ENDIF
N50 V.P.STR = LEFT["Hello world!", 5]
N60 $IF V.P.STR != "Hello"
N70 #ERROR [ID 2]
N80 $ENDIF
N90 V.P.STR = MID["How are you?", 3, 5]
N100 $IF V.P.STR != "are"
N110 #ERROR [ID 3]
N120 $ENDIF
N130 V.P.STR = RIGHT["Hello world! How are you?", 12]
N140 $IF V.P.STR != "How are you?"
N150 #ERROR [ID 4]
N160 $ENDIF
N170 M30
