# Everything is prepared by scripts/setup.sh, which does nothing if nothing has changed.

PYTHON_IN_VENV := .venv/bin/python
ARGS :=
QUICK := app/cameras app/checking/test_task_file.py app/checking/test_values.py app/checking/test_words.py app/images/test_placement.py app/images/pair app/images/compare \
	app/instruments/costs app/instruments/laboratory app/instruments/outside app/instruments/probe app/lecture app/state/test_bounds.py app/state/test_state.py app/ui \
	project/test_layers.py renderer/camera renderer/images

.DEFAULT_GOAL := help
.PHONY: help setup run test quick attack bench conformance install-check notebooks pictures lint requirements clean

help:
	@echo 'make setup          prepare .venv for development; run and test do it, too'
	@echo 'make run            open the window           make run ARGS="spheres"'
	@echo 'make test           run the tests             make test ARGS="-k camera"'
	@echo 'make quick          run in a minute what a change most likely breaks'
	@echo 'make attack         half an hour of attacks; make attack ARGS="random_events --minutes 10"'
	@echo 'make bench          measure the tracer beside others; make bench ARGS="--quick"'
	@echo 'make conformance    hold the formats of cameras against the programs that they are of'
	@echo 'make install-check  install the built packages by pip, pipx and uv, under each Python that is here'
	@echo 'make notebooks      drive the widget in JupyterLab and marimo, in Chromium'
	@echo 'make pictures       draw the pictures of the window in docs/ anew'
	@echo 'make lint           ruff, mypy and vulture'
	@echo 'make requirements   pin the packages anew     make requirements ARGS="--upgrade"'
	@echo 'make clean          remove .venv and everything else that was made'

setup:
	@sh scripts/setup.sh dev

# -P: not what else lies in this folder, a numpy.py for instance.
run:
	@sh scripts/setup.sh
	@$(PYTHON_IN_VENV) -P -m lucida $(ARGS)

# Two processes more than processors, each with whole files or classes. ARGS="-n 0": all in one process.
# Nothing may follow: pytest's closing line is the last. Bytecode is kept: some hundred processes
# would compile all modules anew. Without Hypothesis' plugin, which reads them in each process.
test: export PYTHONDONTWRITEBYTECODE =
test:
	@sh scripts/setup.sh tests
	@$(PYTHON_IN_VENV) -m pytest -n auto --dist loadscope --no-loadscope-reorder -p no:hypothesispytest $(ARGS)

# The linters, and the rooms whose tests need neither a window nor a compilation.
quick: setup
	@sh scripts/lint.sh
	@$(PYTHON_IN_VENV) -m pytest -n auto --dist loadscope $(addprefix tests/,$(QUICK)) $(ARGS)

# What takes too long for each change: random events, mutations and what else is in tools/attack.
attack: setup
	@$(PYTHON_IN_VENV) -m tools.attack $(ARGS)

# In .venv-bench, which has the peers and sees the packages of .venv.
bench: setup
	@$(PYTHON_IN_VENV) -m tools.peer_environment bench
	@.venv-bench/bin/python -m tools.benchmarks $(ARGS)

# The same for the formats of cameras, in .venv-conformance.
conformance: setup
	@$(PYTHON_IN_VENV) -m tools.peer_environment conformance
	@.venv-conformance/bin/python -m tools.conformance $(ARGS)

install-check: setup
	@$(PYTHON_IN_VENV) -m tools.installing $(ARGS)

# The widget in a browser, in .venv-notebooks.
notebooks:
	@sh scripts/setup.sh tests
	@$(PYTHON_IN_VENV) -m tools.peer_environment notebooks
	@.venv-notebooks/bin/python -m tools.notebooks $(ARGS)

pictures: setup
	@$(PYTHON_IN_VENV) docs/draw_window.py $(ARGS)

lint: setup
	@sh scripts/lint.sh

requirements: setup
	@sh scripts/requirements.sh $(ARGS)

clean:
	rm -rf .venv .venv-bench .venv-conformance .venv-notebooks build dist out .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find app lucida renderer shaders tests tools -name __pycache__ -type d -prune -exec rm -rf {} +
