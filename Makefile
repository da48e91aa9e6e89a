# make run      set everything up and solve the rough ball (configs/rough.toml) on two ranks; ARGS="..." adds options
# make test     set everything up and run all tests: on one rank, on two, on three
# make env      print the shell lines that put the environment on: eval "$(make -s env)"
# make clean    remove the environment (.venv); the next command sets it up anew
#
# What the pages show:
# make pictures the pictures of the cases in configs/README.md (a few minutes)
# make tables   the table "Measured" in runs/README.md
# make studies  the other tables and pictures in runs/tables (hours); make study-NAME those of one study
# make sweeps   tables of sweeps, the same way
# make page     put the tables into the pages

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

# make pictures   run the six cases of configs/README.md and draw each into configs/pictures
PICTURES := configs/pictures
CASES := runs/cases
RUN_CASE := mpiexec -n 2 python -m mgehl run --force --quiet
SPEEDS := 20 0.6 0.1
DRAW := mgehl plot --format png --dpi 88 --out runs/cases/plots
pictures: $(ENVIRONMENT)
	mkdir -p $(PICTURES)
	for c in ball_bearing cam coated dent rough; do ( $(ON) $(RUN_CASE) configs/$$c.toml --out $(CASES)/$$c ) || exit 1; done
	for u in $(SPEEDS); do ( $(ON) $(RUN_CASE) configs/rough.toml --set motion.speed="$$u mm/s" \
	  --out $(CASES)/$$u-mm-s ) || exit 1; done
	$(ON) $(RUN_CASE) configs/cam.toml --set motion.speed="0.15 m/s" --out $(CASES)/cam_slow
	for c in ball_bearing coated dent rough; do ( $(ON) $(DRAW) $(CASES)/$$c --kind film && \
	  mv $(CASES)/plots/film.png $(PICTURES)/$$c.png ) || exit 1; done
	$(ON) $(DRAW) $(CASES)/cam $(CASES)/cam_slow --kind compare && mv $(CASES)/plots/compare-lines.png $(PICTURES)/cam.png
	$(ON) $(DRAW) $(CASES)/20-mm-s $(CASES)/0.6-mm-s $(CASES)/0.1-mm-s --kind compare && mv $(CASES)/plots/compare-lines.png $(PICTURES)/speeds.png

.PHONY: pictures

# make tables   run the cases of the table "Measured" and write it to runs/tables
TABLE := runs/acceptance
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
	$(ON) mgehl collect $(TABLE)/* --out runs/tables/acceptance.csv

.PHONY: tables

# make large   the film on 4097 nodes a side: 14 GiB, two minutes on two cores
large: $(ENVIRONMENT)
	$(ON) $(MGEHL) configs/full_film.toml --set grid.nodes=4097 --out runs/large/full-film-4097
	$(ON) mgehl collect runs/large/* --out runs/tables/large.csv

.PHONY: large

# make bench   seconds of three cases on 1025 nodes, on one rank and on two (four minutes; nothing else may run)
BENCH := --case film-1025 --case contact-1025 --case thick-1025 --repeat 3
bench: $(ENVIRONMENT)
	for r in 1 2; do ( $(ON) mpiexec -n $$r python -m mgehl bench $(BENCH) ) || exit 1; done

.PHONY: bench

# make studies     run all studies and write their tables, and the pictures that pages show, to runs/tables (hours)
# make study-NAME  one of them. One that was stopped goes on; what did not converge says so in the table.
STUDIES := wedge grid transition methods schemes error rough passages mixed machine rollers solids stribeck waviness moving courses dry
WITH_grid := --nodes 257,513,1025,2049
WITH_transition := --nodes 257,513,1025
SHOWN_courses := *.png
SHOWN_grid := *.png
SHOWN_moving := *.png
SHOWN_solids := *.png
SHOWN_stribeck := stribeck.png
SHOWN_transition := *figure-14.png
studies: $(STUDIES:%=study-%)
study-%: $(ENVIRONMENT)
	( $(ON) mpiexec -n 2 python -m mgehl study $* $(WITH_$*) --resume --quiet ); test $$? -le 1
	cd runs/study-$* && for f in *.csv $(SHOWN_$*); do case $$f in $**) t=$$f ;; *) t=$*-$$f ;; esac; \
	  cp $$f ../tables/$$t || exit 1; done

.PHONY: studies

# make movies   the courses of study-courses as movies: start, stop, reversal, turn, load (runs/study-courses/runs/*/plots)
movies: study-courses
	for r in runs/study-courses/runs/*/frames.nc; do ( $(ON) mgehl plot $${r%/*} --movie ) || exit 1; done

.PHONY: movies

# make sweeps      run the sweeps that pages show and write their tables to runs/tables (hours)
# make sweep-NAME  one of them. One that was stopped goes on; a point without an answer says so in the table.
SWEEPS := slow rest rest-bare solids-fine traction
BY_DEFAULT := --set grid.x=auto --set grid.y=auto --set discretization.couette=3B --set discretization.face_mobility=linear-gap
SLOW_GRIDS := 129 257 513 1025
SLOW := $(BY_DEFAULT) --set solver.start=film --over motion.speed=
OF_slow-129 := $(SLOW)"7.5,2.5,1,.25,.1,.025,.005 mm/s" --set grid.nodes=129
OF_slow-257 := $(SLOW)"7.5,2.5,1,.25,.1,.025,.005 mm/s" --set grid.nodes=257
OF_slow-513 := $(SLOW)"7.5,2.5,1,.25,.1,.025,.005 mm/s" --set grid.nodes=513
OF_slow-1025 := $(SLOW)"7.5,2.5,1 mm/s" --set grid.nodes=1025
OF_rest := configs/rough.toml --over motion.speed="2e-2..1e-9 m/s:18"
OF_rest-bare := $(OF_rest) --set contact.boundary_film=0 --set grid.nodes=129
OF_solids-fine := configs/rough.toml --set surface.shortest_wavelength="5 um" --over motion.speed="17.5,3,0.5 mm/s" \
  --set grid.nodes=513
TRACTION_OILS := M100 N100 PAO100
TRACTION := configs/traction.toml --over motion.slide_to_roll="log(1e-3..0.4:10)" --over motion.speed="2,16 m/s"
OF_traction-N100 := $(TRACTION) --set lubricant.oil=N100 --set friction.limiting_coefficient=0.053 \
  --set friction.eyring_stress="4.5 MPa"
OF_traction-M100 := $(TRACTION)
OF_traction-PAO100 := $(TRACTION) --set lubricant.oil=PAO100 --set friction.limiting_coefficient=0.035 \
  --set friction.eyring_stress="7.8 MPa"
sweeps: $(SWEEPS:%=sweep-%)
sweep-traction: $(TRACTION_OILS:%=sweep-traction-%)
	$(ON) mgehl plot runs/sweep-traction-*/runs/* --against motion.slide_to_roll --out runs/sweep-traction --format png
	$(ON) mgehl collect runs/sweep-traction-*/runs/* --out runs/tables/traction.csv --columns \
	  lubricant.oil,motion.speed,motion.slide_to_roll,friction
	cp runs/sweep-traction/against-motion.slide_to_roll.png configs/pictures/traction.png
	rm $(TRACTION_OILS:%=runs/tables/traction-%.csv)
sweep-slow: $(SLOW_GRIDS:%=sweep-slow-%)
	$(ON) mgehl collect $(SLOW_GRIDS:%=runs/sweep-slow-%/runs/*) --out runs/tables/slow.csv --columns motion.speed
	rm $(SLOW_GRIDS:%=runs/tables/slow-%.csv)
sweep-%: $(ENVIRONMENT)
	( $(ON) mpiexec -n 2 python -m mgehl sweep $(OF_$*) --set solver.error=false --out runs/sweep-$* --resume \
	  --quiet ); test $$? -le 1
	cp runs/sweep-$*/sweep.csv runs/tables/$*.csv

.PHONY: sweeps

# make page    put the tables of runs/tables into the pages
page: $(ENVIRONMENT)
	$(ON) python tests/tools/page_tables.py

.PHONY: page
