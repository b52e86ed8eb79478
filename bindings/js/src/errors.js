// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/**
 * An argument breaks its contract: a coordinate that is not finite, a site at the center of the sphere, an array of
 * the wrong length, an id that does not exist, an object that was freed. Nothing was changed. An argument of the wrong
 * kind, such as a text for an array, or an option that does not exist, is a TypeError.
 */
export class RondelError extends Error {
  /**
   * @param {string} message one line that names the site and its value
   * @param {number} index of the first bad element (site, query, id) of the array that was passed
   */
  constructor(message, index) {
    super(message);
    this.name = "RondelError";
    /** The first bad element of the array that was passed; 0 if there is none. @readonly */
    this.index = index;
  }
}
