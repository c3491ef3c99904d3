"""Where expansions and numbers meet: studies, comparisons along a decay, error budgets."""
