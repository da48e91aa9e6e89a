# make run      set everything up and solve the rough ball (configs/rough.toml) on two ranks; ARGS="..." adds options
# make test     set everything up and run all tests: on one rank, on two, on three
# make env      print the shell lines that put the environment on: eval "$(make -s env)"
# make clean    remove the environment (.venv); the next command sets it up anew
#
# What the pages show:
# make pictures the pictures of the cases and the table of speeds in configs/README.md (a few minutes)
# make tables   the table "Measured" in runs/README.md
# make studies, rough, means, transition, large   the other tables and pictures in runs/tables

ENVIRONMENT := .venv/mgehl-env.sh
ON := . ./$(ENVIRONMENT) &&

# Processes that share the tests of one rank, file by file: what a file's tests share is solved once. Some tests
# wait, so there is one process more than cores.
WORKERS := 3

run: $(ENVIRONMENT)
	$(ON) mpiexec -n 2 python -m mgehl run $(ARGS)

test: $(ENVIRONMENT)
	$(ON) python -m pytest -m "not parallel" -n $(WORKERS) --dist loadfile
	$(ON) mpiexec -n 2 python -m pytest tests/parallel -m parallel -q
	$(ON) mpiexec -n 3 python -m pytest tests/parallel -m parallel -q

env: $(ENVIRONMENT)
	@cat $(ENVIRONMENT)

$(ENVIRONMENT): .ci/setup pyproject.toml
	@bash .ci/setup >&2

clean:
	rm -rf .venv

.PHONY: run test env clean

# make pictures   run the six cases of configs/README.md, draw each into configs/pictures, write the table of speeds
PICTURES := configs/pictures
CASES := runs/cases
RUN_CASE := mpiexec -n 2 python -m mgehl run --force --quiet
SPEEDS := 500 100 20 5 2 1 0.6 0.3 0.1
OF_SPEEDS := run,converged,lambda,mean film nm,load on contact,contact/Hertz area,inlet cells,convolutions
DRAW := mgehl plot --format png --dpi 88 --out runs/cases/plots
pictures: $(ENVIRONMENT)
	mkdir -p $(PICTURES)
	for c in ball_bearing cam coated dent rough; do ( $(ON) $(RUN_CASE) configs/$$c.toml --out $(CASES)/$$c ) || exit 1; done
	for u in $(SPEEDS); do ( $(ON) $(RUN_CASE) configs/rough.toml --set motion.speed="$$u mm/s" \
	  --out $(CASES)/$$u-mm-s ) || exit 1; done
	$(ON) mgehl collect $(SPEEDS:%=$(CASES)/%-mm-s) --columns "$(OF_SPEEDS)" --out runs/tables/speeds.csv > runs/tables/speeds.md
	$(ON) $(RUN_CASE) configs/cam.toml --set motion.speed="0.15 m/s" --out $(CASES)/cam_slow
	for c in ball_bearing coated dent rough; do ( $(ON) $(DRAW) $(CASES)/$$c --kind film && \
	  mv $(CASES)/plots/film.png $(PICTURES)/$$c.png ) || exit 1; done
	$(ON) $(DRAW) $(CASES)/cam $(CASES)/cam_slow --kind compare && mv $(CASES)/plots/compare-lines.png $(PICTURES)/cam.png
	$(ON) $(DRAW) $(CASES)/20-mm-s $(CASES)/0.6-mm-s $(CASES)/0.1-mm-s --kind compare && mv $(CASES)/plots/compare-lines.png $(PICTURES)/speeds.png

.PHONY: pictures

# make tables   run the cases of the table "Measured" and write it to runs/tables
TABLE := runs/acceptance
SHORT := run,nodes,converged,central nm,minimum nm,contact nodes on X,on Y,Eq. 2 violations,inlet cells,convolutions,most GMRES iterations,wall s
MGEHL := mpiexec -n 2 python -m mgehl run --force --quiet

tables: $(ENVIRONMENT)
	$(ON) $(MGEHL) configs/full_film.toml --out $(TABLE)/full-film
	$(ON) $(MGEHL) configs/full_film.toml --set grid.nodes=2049 --out $(TABLE)/full-film-2049
	$(ON) $(MGEHL) configs/full_film.toml --set grid.nodes=513 --set motion.speed=0.03 --out $(TABLE)/film-30mm-s-513
	$(ON) $(MGEHL) configs/thick_film.toml --out $(TABLE)/thick-film
	for n in 257 513 1025; do ( $(ON) $(MGEHL) configs/point_contact.toml --set grid.nodes=$$n \
	  --out $(TABLE)/full-contact-$$n ) || exit 1; done
	$(ON) $(MGEHL) configs/elliptical.toml --out $(TABLE)/elliptical
	$(ON) $(MGEHL) configs/elliptical_dry.toml --out $(TABLE)/elliptical-dry
	for m in 20 200; do for n in 65 129 257; do for s in 1B 2B; do ( $(ON) $(MGEHL) configs/moes_$${m}_10.toml \
	  --set grid.nodes=$$n --set discretization.couette=$$s --out $(TABLE)/moes-$$m-10-$$s-$$n ) || exit 1; \
	  done; done; done
	for r in 1 2 3; do ( $(ON) mpiexec -n $$r python -m mgehl run --force --quiet configs/full_film.toml \
	  --set grid.nodes=513 --set motion.speed=0.03 --out $(TABLE)/ranks-$$r ) || exit 1; done
	$(ON) mgehl plot $(TABLE)/full-film --kind film --format png && cp $(TABLE)/full-film/plots/film.png \
	  runs/tables/full-film-film.png
	$(ON) mgehl collect $(TABLE)/* --out runs/tables/acceptance.csv > runs/tables/acceptance.md
	$(ON) mgehl collect $(TABLE)/* --columns "$(SHORT)" > runs/tables/short.md

.PHONY: tables

# make large   the film on 4097 nodes a side: 14 GiB, two minutes on two cores
large: $(ENVIRONMENT)
	$(ON) $(MGEHL) configs/full_film.toml --set grid.nodes=4097 --out runs/large/full-film-4097
	$(ON) mgehl collect runs/large/* --out runs/tables/large.csv > runs/tables/large.md

.PHONY: large

# make bench   seconds of three cases on 1025 nodes, on one rank and on two (four minutes; nothing else may run)
BENCH := --case film-1025 --case contact-1025 --case thick-1025 --repeat 3
bench: $(ENVIRONMENT)
	for r in 1 2; do ( $(ON) mpiexec -n $$r python -m mgehl bench $(BENCH) > runs/tables/bench-$$r.txt ) || exit 1; done

.PHONY: bench

# make thick   convolutions and GMRES of thick films by four schemes on four grids (five minutes)
THICK := runs/thick
OF_THICK := run,nodes,converged,central nm,minimum nm,convolutions,Newton steps on finest,most GMRES iterations
thick: $(ENVIRONMENT)
	for m in 20 200; do for s in 2B/arithmetic 3B/arithmetic 3B/logarithmic 3B/linear-gap; do for n in 129 257 513 1025; do \
	  ( $(ON) $(MGEHL) configs/moes_$${m}_10.toml --no-error --set grid.nodes=$$n \
	  --set discretization.couette=$${s%/*} --set discretization.face_mobility=$${s#*/} \
	  --out $(THICK)/M-$$m-$${s%/*}-$${s#*/}-$$n ) || exit 1; done; done; done
	$(ON) mgehl collect $(THICK)/* --columns "$(OF_THICK)" --out runs/tables/thick.csv > runs/tables/thick.md

.PHONY: thick

# make studies   run the studies and write their tables to runs/tables
studies: $(ENVIRONMENT)
	for s in wedge schemes angle error; do ( $(ON) mpiexec -n 2 python -m mgehl study $$s --force --quiet ) || exit 1; done
	for s in line inlet methods domain accuracy soft; do ( $(ON) python -m mgehl study $$s --force --quiet ) || exit 1; done
	for s in wedge schemes angle error line inlet methods domain accuracy soft; do for f in runs/study-$$s/*.md runs/study-$$s/*.csv; do \
	  cp $$f runs/tables/$$s-$$(basename $$f) || exit 1; done; done
	cp runs/study-angle/films.png runs/tables/angle-films.png
	$(ON) mpiexec -n 2 python -m mgehl study error --cases 40 --force --quiet --out runs/study-error-random
	for f in bands cases; do for e in md csv; do cp runs/study-error-random/$$f.$$e runs/tables/error-random-$$f.$$e || exit 1; \
	  done; done

.PHONY: studies

# make rough     run study rough and write its table and pictures to runs/tables; points that did not converge say so in it
rough: $(ENVIRONMENT)
	( $(ON) mpiexec -n 2 python -m mgehl study rough --resume --quiet ); test $$? -le 1
	cp runs/study-rough/rough.md runs/study-rough/rough.csv runs/tables/
	for f in load-share states; do cp runs/study-rough/$$f.png runs/tables/rough-$$f.png || exit 1; done

.PHONY: rough

# make mixed     run studies mixed and waviness and write their tables to runs/tables; cases that did not converge say so in them
mixed: $(ENVIRONMENT)
	for s in mixed waviness; do ( $(ON) mpiexec -n 2 python -m mgehl study $$s --resume --quiet ); test $$? -le 1 || exit 1; done
	( $(ON) mpiexec -n 2 python -m mgehl study mixed --nodes 513 --cases 20 --resume --quiet --out runs/study-mixed-513 ); test $$? -le 1
	for e in md csv; do cp runs/study-mixed-513/mixed.$$e runs/tables/mixed-513.$$e && \
	  cp runs/study-mixed-513/mixed-summary.$$e runs/tables/mixed-513-summary.$$e || exit 1; done
	for e in md csv; do cp runs/study-mixed/mixed.$$e runs/study-mixed/mixed-summary.$$e runs/tables/ || exit 1; \
	  for t in line point; do cp runs/study-waviness/$$t.$$e runs/tables/waviness-$$t.$$e || exit 1; done; done

.PHONY: mixed

# make machine   run study machine and write its tables to runs/tables (ten minutes); cases that did not converge say so
machine: $(ENVIRONMENT)
	( $(ON) mpiexec -n 2 python -m mgehl study machine --resume --quiet ); test $$? -le 1
	for t in machine machine-summary; do for e in md csv; do cp runs/study-machine/$$t.$$e runs/tables/$$t.$$e || exit 1; done; done

.PHONY: machine

# make rollers   the same of rough line contacts (five minutes)
rollers: $(ENVIRONMENT)
	( $(ON) python -m mgehl study rollers --resume --quiet ); test $$? -le 1
	for t in rollers rollers-summary; do for e in md csv; do cp runs/study-rollers/$$t.$$e runs/tables/$$t.$$e || exit 1; done; done

.PHONY: rollers

# make layers    contact that keeps a boundary film of 2 nm: a rough surface on three grids, a smooth ball from film and contact
BAND := configs/rough.toml --set contact.load="100 N" --set surface.shortest_wavelength="45 um" --set motion.speed="0.1 mm/s" \
  --set discretization.couette=1B
SMOOTH := /dev/null --set contact.load="100 N" --set contact.boundary_film="2 nm" --set grid.nodes=257 \
  --set "grid.x=[-2.0, 1.5]" --set "grid.y=[-1.75, 1.75]" --no-error
MIXED := run,nodes,converged,Eq. 2 violations,load on contact,contact/Hertz area,mean film nm,convolutions,wall s
LAYERS := run,converged,central nm,minimum nm,load on contact,contact/Hertz area,Eq. 2 violations,inlet cells,convolutions
layers: $(ENVIRONMENT)
	for n in 257 513 1025; do ( $(ON) $(MGEHL) $(BAND) --set grid.nodes=$$n --out runs/band/$$n ) || exit 1; done
	$(ON) mgehl collect runs/band/* --columns "$(MIXED)" --out runs/tables/band.csv > runs/tables/band.md
	for u in 10 3 1 0.5 0.2 0.1; do for s in film contact; do ( $(ON) $(MGEHL) $(SMOOTH) --set motion.speed="$$u mm/s" \
	  --set solver.start=$$s --out runs/layers/$$u-mm-s-$$s ); test $$? -le 1 || exit 1; done; done
	$(ON) mgehl collect runs/layers/* --columns "$(LAYERS)" --out runs/tables/layers.csv > runs/tables/layers.md

.PHONY: layers

# make peaks     run study peaks and write its tables to runs/tables (half an hour)
peaks: $(ENVIRONMENT)
	( $(ON) mpiexec -n 2 python -m mgehl study peaks --resume --quiet )
	for t in balls summary; do for e in md csv; do cp runs/study-peaks/$$t.$$e runs/tables/peaks-$$t.$$e || exit 1; done; done

.PHONY: peaks

# make gaps      run study gaps, and configs/rough.toml with bands on three grids; write both to runs/tables (half an hour)
OF_GAPS := run,nodes,converged,inlet cells,mean gap nm,loaded gap nm,load on contact,mean film nm,convolutions
gaps: $(ENVIRONMENT)
	( $(ON) mpiexec -n 2 python -m mgehl study gaps --resume --quiet )
	for t in gaps gaps-summary; do for e in md csv; do cp runs/study-gaps/$$t.$$e runs/tables/$$t.$$e || exit 1; done; done
	for n in 257 513 1025; do ( $(ON) $(MGEHL) configs/rough.toml --set grid.nodes=$$n --out runs/rough-gaps/$$n ) || exit 1; done
	$(ON) mgehl collect runs/rough-gaps/* --columns "$(OF_GAPS)" --out runs/tables/rough-gaps.csv > runs/tables/rough-gaps.md

.PHONY: gaps

# make rough-schemes   who carries the load of configs/rough.toml by four schemes on three grids (ten minutes)
OF_SCHEMES := run,converged,inlet cells,load on contact,contact/Hertz area,Eq. 2 violations,mean film nm,convolutions
rough-schemes: $(ENVIRONMENT)
	for n in 257 513 1025; do for c in 1B 2B 3B 3L; do ( $(ON) $(MGEHL) configs/rough.toml --set grid.nodes=$$n \
	  --set discretization.couette=$$c --out runs/rough-schemes/$$c-$$n ); test $$? -le 1 || exit 1; done; done
	$(ON) mgehl collect runs/rough-schemes/* --columns "$(OF_SCHEMES)" --out runs/tables/rough-schemes.csv \
	  > runs/tables/rough-schemes.md

.PHONY: rough-schemes

# make balls    a rough ball of 100 N without a boundary film, 20 to 400 nm rms, 1 m/s to 1 um/s, from film and contact (a quarter of an hour)
BALL := /dev/null --set contact.load="100 N" --set surface.kind=self-affine --set surface.hurst=0.8 --set surface.seed=1 \
  --set surface.shortest_wavelength="30 um" --set surface.longest_wavelength="200 um" --set grid.nodes=257 \
  --set "grid.x=[-2.0, 1.5]" --set "grid.y=[-1.75, 1.75]" --set discretization.couette=1B --no-error
BALLS := run,converged,lambda,central nm,load on contact,contact/Hertz area,Eq. 2 violations,convolutions,wall s
balls: $(ENVIRONMENT)
	for r in 20 100 200 400; do for u in 1 1e-1 1e-2 1e-3 1e-4 1e-5 1e-6; do for s in film contact; do \
	  ( $(ON) $(MGEHL) $(BALL) --set surface.rms="$$r nm" --set motion.speed=$$u --set solver.start=$$s \
	  --out runs/balls/$$r-nm-$$u-m-s-$$s ); test $$? -le 1 || exit 1; done; done; done
	$(ON) mgehl collect runs/balls/* --columns "$(BALLS)" --out runs/tables/balls.csv > runs/tables/balls.md

.PHONY: balls

# make means   the film at 7.5 mm/s by the other means of the mobility, and by the scheme 2B, on 1025 and 2049 nodes
means: $(ENVIRONMENT)
	for m in geometric harmonic; do for n in 1025 2049; do ( $(ON) $(MGEHL) configs/full_film.toml --set grid.nodes=$$n \
	  --set discretization.face_mobility=$$m --out runs/means/$$m-$$n ) || exit 1; done; done
	for n in 1025 2049; do ( $(ON) $(MGEHL) configs/full_film.toml --set grid.nodes=$$n --set discretization.couette=2B \
	  --out runs/means/2B-$$n ) || exit 1; done
	$(ON) mgehl collect runs/means/* --out runs/tables/means.csv > runs/tables/means.md

.PHONY: means

# make transition   run the studies of the transition and write their tables and pictures to runs/tables (hours)
TRANSITION := runs/study-
transition: $(ENVIRONMENT)
	for n in 257 513 1025; do ( $(ON) mpiexec -n 2 python -m mgehl study transition --grid $$n --resume \
	  --quiet --out $(TRANSITION)transition-$$n ) || exit 1; done
	for n in 257 513 1025; do ( $(ON) mpiexec -n 2 python -m mgehl study transition --grid $$n --resume \
	  --mean geometric --quiet --out $(TRANSITION)transition-$$n-geometric ) || exit 1; done
	( $(ON) mpiexec -n 2 python -m mgehl study grid --nodes 257,513,1025,2049 --resume --quiet ) || exit 1
	for s in onset bracket; do ( $(ON) mpiexec -n 2 python -m mgehl study $$s --resume --quiet ) || exit 1; done
	cp $(TRANSITION)transition-*/transition-*.* runs/tables/
	for s in grid onset bracket; do for f in $(TRANSITION)$$s/*.md $(TRANSITION)$$s/*.csv $(TRANSITION)$$s/*.png; do \
	  cp $$f runs/tables/$$s-$$(basename $$f) || exit 1; done; done

.PHONY: transition
