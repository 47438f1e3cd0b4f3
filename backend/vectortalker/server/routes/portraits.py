"""Portraits: upload, picture, faces, deletion."""

from __future__ import annotations

import anyio
from anyio import to_thread
from fastapi import APIRouter, Response, UploadFile

from vectortalker import schema
from vectortalker.server import portraits
from vectortalker.server.removal import remove_portrait
from vectortalker.server.routes.access import Has, Id

router = APIRouter(prefix="/api/portraits", tags=["portraits"])

DECODING = anyio.CapacityLimiter(2)  # a 50 MP picture takes up to 1 GB while it is decoded


@router.post("", status_code=201)
async def add_portrait(file: UploadFile, has: Has) -> schema.Portrait:
    """Limits are checked before any pixel is decoded."""
    data = await file.read()
    name = file.filename or ""
    return await to_thread.run_sync(portraits.add, has.store, has.blobs, data, name, limiter=DECODING)


@router.get("/{portrait_id}", operation_id="get_portrait")
def get_portrait(portrait_id: Id, has: Has) -> schema.Portrait:
    return portraits.describe(has.blobs, portrait_id)


@router.get("/{portrait_id}/image", response_class=Response, responses={200: {"content": {"image/png": {}}}})
async def get_image(portrait_id: Id, has: Has) -> Response:
    """The normalised picture."""
    headers = {"Cache-Control": "private, max-age=3600"}
    data = await to_thread.run_sync(portraits.image, has.blobs, portrait_id, limiter=DECODING)
    return Response(data, media_type="image/png", headers=headers)


@router.get("/{portrait_id}/faces")
async def get_faces(portrait_id: Id, has: Has) -> schema.Faces:
    return await to_thread.run_sync(portraits.faces, has.blobs, portrait_id, limiter=DECODING)


@router.delete("/{portrait_id}", status_code=204)
def delete_portrait(portrait_id: Id, has: Has) -> None:
    """Everything made from it goes with it, at once; what is being made is stopped."""
    remove_portrait(has, portrait_id)
