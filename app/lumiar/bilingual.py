"""What is said of a report of `lumiar bench`; on a page in every language, one of them shown."""

from html import escape

TEXT = {
    "en": {
        "renderer": "drawn by",
        "cpu": "processor",
        "cores": "cores",
        "system": "system",
        "clock": "clock",
        "version": "program",
        "date": "date",
        "quick": "a quick run: coarser, with fewer variants",
        "error": "error",
        "cost": "cost",
        "interval": "interval",
        "ns": "ns per evaluation",
        "ms": "ms per frame",
        "values": "Values",
        "default": "Lumiar's choice",
        "off": "Taken off every cost: {} {}.",
        "visible": "seen above",
        "floor": "as good as exact",
        "alone": "With no other variant",
        "scene": "this scene",
        "none": "no report here: run `lumiar bench`",
        "scale": "error",
        "log scale": "error, log scale",
    },
    "pt": {
        "renderer": "desenhado por",
        "cpu": "processador",
        "cores": "núcleos",
        "system": "sistema",
        "clock": "relógio",
        "version": "programa",
        "date": "data",
        "quick": "execução rápida: mais grossa, com menos variantes",
        "error": "erro",
        "cost": "custo",
        "interval": "intervalo",
        "ns": "ns por avaliação",
        "ms": "ms por quadro",
        "values": "Valores",
        "default": "escolha do Lumiar",
        "off": "Descontado de cada custo: {} {}.",
        "visible": "vê-se acima",
        "floor": "como exato",
        "alone": "Sem outra variante",
        "scene": "esta cena",
        "none": "nenhum relatório aqui: execute `lumiar bench`",
        "scale": "erro",
        "log scale": "erro, escala log",
    },
}


def said(texts, tag="span", looks=""):
    """Return texts {language: text}, one element each, escaped."""
    looks = f' class="{looks}"' if looks else ""
    if tag == "span" and not looks and texts["en"] == texts["pt"]:
        return escape(texts["en"])
    return "".join(
        f'<{tag} lang="{lang}"{looks}>{escape(text)}</{tag}>' for lang, text in texts.items()
    )


def word(key):
    """Return one of TEXT, or what has no name there as it is, in each language."""
    return {lang: words.get(key, key) for lang, words in TEXT.items()}


def name_of(one, key):
    """Return what a case, variant or metric of a study is called in each language."""
    return one["words"].get(key) or dict.fromkeys(TEXT, key)
