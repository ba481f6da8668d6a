"""Batches: many questions in one file, answered within a day at half the price.

`backend` answers from finished batches and collects new questions for the next one. `folder` stores both on disk.
`service` is the client of the server. `scene2hap.baking.many.batch` sends whole chains of questions this way.

Source: OpenAI, guide "Batch API" and the reference of `/v1/files` and `/v1/batches`.
"""

from scene2hap.llm.batch.backend import BatchBackend
from scene2hap.llm.batch.folder import BatchFolder, BatchRow
from scene2hap.llm.batch.service import BatchService, BatchStatus
from scene2hap.llm.protocol import AnswerPending

__all__ = ["AnswerPending", "BatchBackend", "BatchFolder", "BatchRow", "BatchService", "BatchStatus"]
