; check --identity-trafo --external LENGTH=12.5: exit 0
; warning K-0111 at 3:1
#TRAFO ON
X V.E.LENGTH F1000
M30
