"""What the points of one case and metric advise, in a sentence or two, derived from them alone."""

from . import study
from .notation import number

NAMED = 5  # in a sentence; what is more is counted
WORDS = {
    "en": {
        "worth": "{pick} costs {more} {unit} more than {rival} and {gain}: use it.",
        "gain": "removes an error of up to {before}",
        "less": "brings the error from {before} down to {after}",
        "cheapest": "{pick} errs by {after} at most, and nothing is clearly cheaper: use it.",
        "hidden": "{pick} errs by {after} at most, which does not show, and nothing that exact is"
        " cheaper: use it.",
        "shows": "Its error still shows.",
        "beaten": "No bargain: {names}.",
        "more": "{} more",
        "default": "Lumiar's default, {name}, is beaten by {names}.",
        "no error": "{pick} has no error to speak of, and nothing is clearly cheaper: use it.",
    },
    "pt": {
        "worth": "{pick} custa {more} {unit} a mais que {rival} e {gain}: use.",
        "gain": "elimina um erro de até {before}",
        "less": "reduz o erro de {before} para {after}",
        "cheapest": "{pick} erra no máximo {after}, e nada é claramente mais barato: use.",
        "hidden": "{pick} erra no máximo {after}, o que não se vê, e nada tão exato é mais barato:"
        " use.",
        "shows": "O erro ainda se vê.",
        "beaten": "Não compensa: {names}.",
        "more": "mais {}",
        "default": "O padrão do Lumiar, {name}, é superado por {names}.",
        "no error": "{pick} não tem erro que conte, e nada é claramente mais barato: use.",
    },
}


def chosen(group, metric):
    """Return the point to use: the cheapest of the front whose error does not show.

    Of those that cost about the same the most exact, Lumiar's own if errors are alike; the most
    exact of the front if every error shows.
    None where there is no front.
    """
    front = [point for point in group if point.pareto]
    if not front:
        return None
    unseen = [point for point in front if point.error < metric.visible]
    if not unseen:
        return min(front, key=lambda point: (point.error, point.cost))
    least = min(unseen, key=lambda point: point.high)
    alike = [point for point in unseen if not study.cheaper(least, point)]
    exact = study.CLEAR * max(metric.floor, min(point.error for point in alike))
    return min((p for p in alike if p.error <= exact), key=lambda p: (not p.default, p.error))


def sentences(group, metric, names, lang):
    """Return the sentences that the marked points of one case and metric support.

    names maps a variant to its name in the language. Empty where nothing can be said.
    """
    words, pick = WORDS[lang], chosen(group, metric)
    if pick is None or len(group) < 2:
        return []

    def said(points):
        told = [names[p.variant] for p in sorted(points, key=lambda p: p.error)]
        more = words["more"].format(len(told) - NAMED + 1)
        return ", ".join(told if len(told) <= NAMED else [*told[: NAMED - 1], more])

    rivals = [p for p in group if p.pareto and study.cheaper(p, pick) and p.error > pick.error]
    facts = {"pick": names[pick.variant], "after": number(pick.error, 2, lang), "unit": pick.unit}
    if rivals:
        rival = min(rivals, key=lambda p: p.error)
        facts |= {"rival": names[rival.variant], "before": number(rival.error, 2, lang)}
        facts["more"] = number(pick.cost - rival.cost, 2, lang)
        small = pick.error < max(metric.floor, 0.02 * rival.error)
        facts["gain"] = words["gain" if small else "less"].format(**facts)
        out = [words["worth"].format(**facts)]
    else:
        kind = "hidden" if pick.error < metric.visible else "cheapest"
        kind = "no error" if pick.error < metric.floor else kind
        out = [words[kind].format(**facts)]
    out[0] = out[0][0].upper() + out[0][1:]
    if pick.error >= metric.visible:
        out.append(words["shows"])
    others = [p for p in group if not p.pareto]
    if others:
        out.append(words["beaten"].format(names=said(others)))
    return out


def beaten(variant, by, names, lang):
    """Return the sentence on a default that others beat in every metric; see `study.beaten`."""
    others = ", ".join(names[one] for one in by)
    return WORDS[lang]["default"].format(name=names[variant], names=others)
