# make run    set everything up and run the main job on two ranks
# make test   set everything up and run all tests, serial and parallel
# make env    print the shell lines that put the environment on: eval "$$(make -s env)"
# make clean  forget the environment (.venv)

ENVIRONMENT := .venv/mgehl-env.sh
ON := . ./$(ENVIRONMENT) &&

run: $(ENVIRONMENT)
	$(ON) mpiexec -n 2 python -m mgehl run $(ARGS)

test: $(ENVIRONMENT)
	$(ON) python -m pytest -m "not parallel"
	$(ON) mpiexec -n 2 python -m pytest -m parallel -q
	$(ON) mpiexec -n 3 python -m pytest -m parallel -q

env: $(ENVIRONMENT)
	@cat $(ENVIRONMENT)

$(ENVIRONMENT): .ci/setup pyproject.toml
	@bash .ci/setup >&2

clean:
	rm -rf .venv

.PHONY: run test env clean
