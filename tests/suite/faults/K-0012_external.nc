; check: exit 1
; error K-0012 at 3:3
X V.E.LENGTH F1000
M30
