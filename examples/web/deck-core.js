// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The script of deck.gl as the module that rondel/deck imports.

export const { Deck, _GlobeView, Layer, MapView } = globalThis.deck;
