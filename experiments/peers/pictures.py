"""Pictures of the same scene by several renderers: numbers that say how alike they are, and a sheet to look at."""
import json
import subprocess

from matplotlib.colors import LogNorm
import numpy

from lib import style

OFF = 0.01  # of the mean radiance: a pixel beyond it sees something else, or in another light
DARKEST, BRIGHTEST = 1e-5, 1.0  # of the difference's scale


def pixels(file):
    """Radiance, h x w x 3."""
    import OpenImageIO
    return OpenImageIO.ImageBuf(str(file)).get_pixels(OpenImageIO.FLOAT).astype(float)[..., :3]


def difference(ours, theirs):
    """Of each pixel, its worst channel's, as a share of the mean radiance."""
    return abs(ours - theirs).max(axis=-1) / ours.mean()


def compare(whittle, ours, theirs):
    """FLIP and RMSE by `whittle compare`, the latter over the mean; the middle pixel's difference; the share of pixels
    off."""
    done = subprocess.run([whittle, "compare", theirs, ours, "--json"], capture_output=True, text=True, check=True)
    metrics = json.loads(done.stdout)
    a, b = pixels(ours), pixels(theirs)
    d = difference(a, b)
    return {"rmse": metrics["rmse"] / a.mean(), "flip": metrics["flip"], "median": float(numpy.median(d)),
            "off": float((d > OFF).mean()),
            "rmse_others": float(numpy.sqrt(((a - b)[d <= OFF] ** 2).mean()) / a.mean()),
            "mean_ratio": float(b.mean() / a.mean())}


def shown(radiance):
    """The same exposure and curve for all: sRGB's approximate 1/2.2, clipped at 1."""
    return numpy.clip(radiance, 0, 1) ** (1 / 2.2)


def sheet(folder, name, title, ours, peers):
    """FOLDER/NAME.png: ours, theirs side by side, and below what differs. peers: label -> EXR."""
    a = pixels(ours)
    figure, axes = style.figure(2, 1 + len(peers), height=4.1 if len(peers) > 1 else 5.6, squeeze=False)
    axes[0, 0].imshow(shown(a))
    axes[0, 0].set_title("Whittle")
    axes[1, 0].text(0.0, 0.95, title, transform=axes[1, 0].transAxes, va="top", fontsize=8.5)
    scale = LogNorm(DARKEST, BRIGHTEST)
    for column, (label, file) in enumerate(peers.items(), 1):
        b = pixels(file)
        axes[0, column].imshow(shown(b))
        axes[0, column].set_title(label)
        bar = axes[1, column].imshow(numpy.clip(difference(a, b), DARKEST, BRIGHTEST), norm=scale, cmap="viridis")
    for axis in axes.flat:
        axis.axis("off")
    figure.colorbar(bar, ax=list(axes[1, 1:]), shrink=0.8, label="difference / mean radiance")
    folder.mkdir(parents=True, exist_ok=True)
    figure.savefig(folder / f"{name}.png", dpi=style.pyplot.rcParams["savefig.dpi"])
    style.pyplot.close(figure)
