; check: exit 1
; error K-0033 at 3:13
#FILTER ON [SHARE=101]
M30
