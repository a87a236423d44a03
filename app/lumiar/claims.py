"""What was found of the properties that a model may claim, and what becomes of its claims."""

TOLERANCE = {  # a claim is two-sided: within this wherever it is made, beyond it somewhere else
    "positive": 0.0,  # of a value (1/sr)
    "reciprocal": 1e-3,  # relative
    "conserving": 1e-4,  # of an albedo
    "constant": 1e-5,  # relative
}
FREE = ("constant",)  # what may be kept silent: it is no merit of a model, it only saves samples


class Findings:
    """The worst that was seen of every property of a model, where it is claimed and elsewhere."""

    def __init__(self, model):
        self.model = model
        self.worst = {name: {} for name in TOLERANCE}

    def note(self, name, amount, values, what):
        """Keep `amount`, and `what` it is in words, if it is the worst of a property so far."""
        within = self.model.covers(name, values)
        kept = self.worst[name].get(within)
        if kept is None or amount > kept[0]:
            self.worst[name][within] = (amount, self.model.changes(values), what)

    def settled(self, name, values):
        """Return whether what is not claimed of these values is known to fail already."""
        if self.model.covers(name, values):
            return False
        return self.worst[name].get(False, (0.0,))[0] > TOLERANCE[name]

    def verdicts(self):
        """Return {claim: {claimed, verdict, agrees, worst, what, where}} as `audit.audit` does."""
        out = {}
        for name, worst in self.worst.items():
            claimed, limit = self.model.claims.get(name), TOLERANCE[name]
            inside = [w for within, w in worst.items() if within]
            outside = [w for within, w in worst.items() if not within]
            holds = all(amount <= limit for amount, *_ in inside)
            fails = any(amount > limit for amount, *_ in outside)
            if claimed is not None and not holds:
                verdict = "broken"
            elif outside and not fails:
                verdict = "holds, unclaimed"
            else:
                verdict = "holds" if claimed is not None else "does not hold"
            amount, where, what = max(worst.values(), default=(0.0, "", ""))
            if claimed is not None and inside:
                amount, where, what = max(inside)
            out[name] = {
                "claimed": "no" if claimed is None else claimed or "yes",
                "verdict": verdict,
                "agrees": verdict in ("holds", "does not hold")
                or (verdict != "broken" and name in FREE),
                "worst": amount,
                "what": what,
                "where": where,
            }
        return out

    def broken(self):
        """Return one line for each claim that a header must not make, or keep silent about."""
        lines = []
        for name, said in self.verdicts().items():
            if said["verdict"] == "broken":
                lines.append(f"claims '{name}', but {said['what']} at {said['where']}")
            elif not said["agrees"]:
                condition = self.model.claims.get(name)
                beyond = f" beyond ({condition})" if condition else ""
                lines.append(f"'{name}' holds everywhere{beyond}; claim it")
        return lines
