"""How accurate a run will be and what it costs: plan, ladder of models, accuracy, verification."""
